# pugixml keeps the offset of each node, from which lines in diagnostics follow. It shows in this layer's header, which no
# public header includes.
find_package(pugixml REQUIRED)
target_link_libraries(roboss_xml PUBLIC pugixml::pugixml)
