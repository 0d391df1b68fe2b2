// What a page orders, given to the Client that orders for all pages.
#pragma once

#include "client/client.h"
#include "gateway/page_request.h"

namespace roboss {

/// Checks the order and gives it to the Client. An Error says what is wrong with it.
Result<> give(Client& client, const PageOrder& order);

}  // namespace roboss
